local a = param("a", 0, {min = 0, max = 1}) local t = time
part("s", sphere(1 + 0.5 * a):translate(sin(t), cos(2 * pi * t), a ^ 2)) for i = 1, value(a) do part("n" .. i, box(a, i, 1)) end
part("r", box(1, 2, 1):rotate(t * 90, 0, 0):scale(0 + a):round(0.1 * a)) part("c", union{sphere(a + 1), torus(1 + a, 0.1 + a), k = a + 0.1})
