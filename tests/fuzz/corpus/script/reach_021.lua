-- Measuring shape S5: a -- Measuring shape S5: a thousand small __metes.
local balls = {}
for i = 1, 999 do
  balls[#balls + 1] = sphere(0.06):translate(1.7 * sin(24.93 * i), 1.7 * sin(37.719 * i))
end
return union(balls)
