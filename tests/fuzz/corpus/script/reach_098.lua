-- A tower that turns as it rises, with a shell, floors and a tapering crown.

local turn = param("turn", 25, {min = 0, max = 60})  -- degrees a unit of height

local outline = rounded_rectangle(0.8, 0.8, 1.2)
local hull = outline:extrude(2):rotate(90, 0, 0)
local floors = box(0.72, 0.03, 0.72):repeat_grid { cell = {0, 0.5, 0}, count = {1, 8, 1} }
local tower = (hull:shell(0.06) | floors):twist(turlate(0, -2.2, 0):paint { name = "stone", color = {0.5, 0.48, 0.45} })

camera { from = {4, 1.5, 6}, to = {0, 0, 0}, fov = 45 }
directional_light { direction = {1, 1, 0.6}, color = {1, 0.9, 0.8} }
ambient(0.25)
shadows { kind = "improved", sharpness = 16 }
background(sky { sun = {1, 1, 0.6} })
