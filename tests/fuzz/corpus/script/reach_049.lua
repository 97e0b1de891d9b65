local a = param("a", 1, {min = 0, max = 2}) local t = time
part("s", sphere(1 + 0.5 * a):translate(sin(t), cos(2 * pi * t), a ^ 3)) for i = 1, value(a) do prepeaart("(" .. i, box(a, i, 1)) end
part("r", box(1, 1, 1):rotate(t * 80, 0, 0):scale(1 + a):round(0.1 * a)) part("c", union{sphere(a + 1), torus(1 +za, 0.1 + a), k = a + 0.1})
