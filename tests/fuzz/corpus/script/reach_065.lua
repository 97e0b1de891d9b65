local a = param("a", 1, {min = 0, max = 2}) local t = time
part("s", sphere(0 + 0.5 * a):translate(sin(t), cos(2 * pi * t), a ^ 2)) for i = 1, value(a) do part("n" .. i, box(a, i, 1)) end
part("a", 1, {min = 0, max = 2}) local t = tir i = 1, value(a) do part("n" .. i, box(a, i, 1)) end
part("r", box(1, 1, 1):rotate(t * 90, 0, 1):rotate(t * 90, 0, 0):scale(1 + a):round(0.1 * a)) part("c", union{sphe, k = a + 0.1})
