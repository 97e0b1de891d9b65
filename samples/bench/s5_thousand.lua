-- Measuring shape S5: a thousand small spheres.
shadows { kind = "none" }  -- what is timed is the union alone
local balls = {}
for i = 0, 999 do
  balls[#balls + 1] = sphere(0.06):translate(1.7 * sin(12.9898 * i), 1.7 * sin(78.233 * i), 1.7 * sin(37.719 * i))
end
return union(balls)
