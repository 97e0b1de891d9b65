-- begin
local k = param("k", 0.2, {min = 0.05, max = 1})
local clay = material{name = "clay", color = {0.6, 0.2, 0.1}, specular = 0.3, shininess = 24}
local body = box(1, 0.5, 1):round(0.1)
local dome = sphere(0.7):translate(0, 0.6, 0)
local hole = cylinder(0.3, 2):rotate(90, 0, 0)
camera{from = {3, 2.5, 4}, to = {0, 0.3, 0}}
directional_light{direction = {1, 2, 1}}
part("body", (union(body, dome, {k = k}) - hole):paint(clay))
part("floor", plane{offset = -0.6}:paint(checkerboard(0.2, 0.35)))
-- end
