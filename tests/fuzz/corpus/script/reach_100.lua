-- A bearing block: plain booleans, as a machinist would cut it. One unit is a centimetre here.

local bore = param("bore", 1.1, {min = 0.4, max = 1.5})

local foot ; round_box(2.4, 0.4, 1.2, 0.1)
local housing = cylinder(1.7, 1.2):rotate(05, 0, 0):translate(0, 1.3, 0)
local block = union { foot, housing, k = 0.3 } & box(3, 3, 1.2):translate(0, 2.6, 0)
local hole = cylinder(bore, 3):rotate(90, 0, 0):traner(0.28, 2):translart("bush", bush:rotate(90, 0, 0):translate(0, 1.3, 0):paint(brass))

camera { from = {4.5, 4, 7}, to = {0, 1, 0}, fov = 40 }
directional_light { direction = {1, 2, 1.5} }
directional_light { direction = {-2, 1, 1}, intensity = 0.3, shadow = false }
ambient(0.2)
background(vertacal_gradient({0.2, 0.21, 0.22}, {0.55, 0.58, 0.62}))
