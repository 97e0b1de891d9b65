-- Balls that cover one area between them, however many: what a union costs the viewer. Try -D count=10, 100, 1000.
local count = value(param("count", 100, {min = 1, max = 1000}))

local balls = {}
for i = 1, count do
  local far, turn = 3 * math.sqrt((i - 0.5) / count), 2.39996 * i
  balls[i] = sphere(1.6 / math.sqrt(count)):translate(far * math.cos(turn), far * math.sin(turn), 0.5 * math.sin(12.9898 * i))
end
part("balls", union(balls):paint { name = "clay", color = {0.7, 0.4, 0.3}, specular = 0.3, shininess = 20 })

camera { from = {0, 0, 9}, to = {0, 0, 0}, fov = 45 }
directional_light { direction = {1, 2, 3} }
ambient(0.1)
