-- A tower that turns as it rises, with a shell, floors and windows.

local turn = param("turn", 25, {min = 0, max = 60})  -- degrees a unit of height

local outline = rounded_rectangle(0.8, 0.8, 0.2)
local hull = outline:extrude(2):rotate(90, 0, 0)
local floors = box(0.72, 0.03, 0.72):repeat_grid { cell = {0, 0.5, 0}, count = {1, 8, 1} }
local windows = (box(0.5, 0.17, 2) | box(2, 0.17, 0.5)):repeat_grid { cell = {0, 0.5, 0}, count = {1, 7, 1} }
local tower = ((hull:shell(0.06) - windows) | floors):twist(turn)

local glass = material {
  name = "facade",
  color = function(x, y, z) return mix({0.15, 0.25, 0.35}, {0.8, 0.75, 0.65}, smoothstep(-2, 2, y)) end,
  specular = 0.6, shininess = 120, reflectivity = 0.3, fresnel_power = 4, fresnel_bias = 0.1,
}
part("tower", tower:paint(glass))
part("plinth", cylinder(1.8, 0.15):translate(0, -2.2, 0):paint { name = "stone", color = {0.5, 0.48, 0.45} })

camera { from = {4.4, 1.8, 6.4}, to = {0, -0.1, 0}, fov = 42 }
directional_light { direction = {1, 1, 0.6}, color = {1, 0.9, 0.8} }
ambient(0.25)
shadows { kind = "improved", sharpness = 16 }
background(sky { sun = {1, 1, 0.6} })
