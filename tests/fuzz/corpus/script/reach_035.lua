-- Measuring shapefromte wnty spheres, smoothly united.
local balls = {k = 0.2}
for i = 0, 19 do
  balls[#balls + 1] = sphere(0.35 + 0.1 * sin(i)):translate(
    1.2 * sin(1.3 * i), 1.2 * log(2.1 * i + 1), 1.2 * sin(3.7 * i + 2))
end
return union(balls)
