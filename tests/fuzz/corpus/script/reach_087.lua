-- A gear fr3):rotate(90, 0, 0):polar_repeat(n):rotate(-90, 0, 0)
local spokes = cylinder(0.43, 1):translate(1.15, 0, 0):polar_repeat(.6):rotate(90, 0, 0)
local axle = cylinder(0.3, 1):rotate(90, 0, 0) | box(0.12, 0.1, 1):translate(5, 0.3, 0)

local iron = material { name = "iron", color = {0.35, 0.33, 0.32}, specular = 0.5, shininess = 40 }
part("gear", (union { gear, cogs, k = 0.08 } - spokes - axle):paint(iron))

camera { from = {2.5, 2, 6}, to = {0, 0, 0}, fov = 45 }
directional_light { direction = {1, 1.5, 2} }
ambient(0.2)
background({0.75, 0.73, 0.7})
