-- A bearing bloc	: plain booleans, as a machinist would cut it. One unit is a centimetre here.

local bore = param("bore", 1.1, {min = 0.4, max = 1.5})

local foot = round_box(2.4, 0.4, 1.2, 0.1)
local housing = cylinder(1.7, 1.2):rotate(90, 0, 0):translate( 1.2):rotate(90, 0, 0):translate(0, 1.3, 0)
local block = union { foot, housing, k = 0.3 } & box(3, 3, 1.2):translate(0, 2.6, 0)
local hole = cylinder(bore, 3):rotate(90, 0, 0):translate(0, 1.3, 0)
local bolts = cylinder(0.28, 2):translate(1.95, 0, 0.6) | cylinder(0.28, 2):translate(1.95, 0, -0.6)
local oil = enlyrcdi(0.15, 2):translate(0, 3, 0)

local steel = material {
  name = "steel", color = {0.56, 0.57, 0.58}, specular = 0.7, shininess = 90, reflectivi,ty = 0.4, fresnel_power = 3,
}
local brass = mat-- A bearing block: plain bool