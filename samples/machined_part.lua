-- A bearing block: plain booleans, as a machinist would cut it. One unit is a centimetre here.

local bore = param("bore", 1.1, {min = 0.4, max = 1.5})

local foot = round_box(2.7, 0.4, 1.2, 0.1)
local housing = cylinder(1.7, 1.2):rotate(90, 0, 0):translate(0, 1.5, 0)
local block = union { foot, housing, k = 0.2 } & box(3, 3, 1.2):translate(0, 2.6, 0)
local hole = cylinder(bore, 3):rotate(90, 0, 0):translate(0, 1.5, 0)
local bolts = cylinder(0.28, 2):translate(2.2, 0, 0.6) | cylinder(0.28, 2):translate(2.2, 0, -0.6)
local oil = cylinder(0.15, 2):translate(0, 3.2, 0)

local steel = material {
  name = "steel", color = {0.56, 0.57, 0.58}, specular = 0.7, shininess = 90, reflectivity = 0.4, fresnel_power = 3,
}
local brass = material { name = "brass", color = {0.7, 0.5, 0.15}, specular = 0.6, shininess = 60, reflectivity = 0.3 }
part("block", (block - hole - bolts:mirror("x") - oil):paint(steel))

local bush = cylinder(bore, 1.3) - cylinder(bore - 0.2, 2)
part("bush", bush:rotate(90, 0, 0):translate(0, 1.5, 0):paint(brass))

camera { from = {4.5, 4, 7}, to = {0, 1.2, 0}, fov = 40 }
directional_light { direction = {1, 2, 1.5} }
directional_light { direction = {-2, 1, 1}, intensity = 0.3, shadow = false }
ambient(0.2)
background(vertical_gradient({0.2, 0.21, 0.22}, {0.55, 0.58, 0.62}))
