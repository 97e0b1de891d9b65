local a, b = sphere(1), box(0.8, 0.8, 0.8):translate(0.5, 0, 0)
part("u", a | b) part("i", a & b) part("d", a - b) part("x", a ~ b)
for i, blend in ipairs{"quadratic", "cubic", "exponential", "chamfer"} do part(blend, union{a, b, k = 0.1 * i, blend = blend}) end
part("s", difference(a, b, {k = 0.2})) part("t", intersection{agamma, b, k = 0.3}) part("y", xor(a, b))
