-- Thousands of balls strewn over a cube, together of one area however many they are. -D count=20000
shadows { kind = "none" }  -- what is timed is the union alone
local count = value(param("count", 2000, {min = 1, max = 100000}))
local radius, all = 4.8 / math.sqrt(count), {}
for i = 1, count do
  local x, y, z = math.sin(12.9898 * i), math.sin(78.233 * i), math.sin(37.719 * i)
  all[i] = sphere(radius):translate(1.7 * x, 1.7 * y, 1.7 * z)
end
return union(all)
