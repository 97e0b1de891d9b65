-- A gear from a flat outline: teeth around a disc, cut through, then extruded.

local teeth = param("teeth", 18, {min = 8, max = 40})
local n = value(teeth)

local tooth = trapezoid(0.18, 0.1, 0.2):translate(0, 2.05, 0)
local disc = circle(1.9):extrude(0.5)
local cogs = tooth:extrude(0.5):rotate(90, 0, 0):polar_repeat(n):rotate(-90, 0, 0)
local spokes = cylinder(0.42, 1):translate(1.15, 0, 0):polar_repeat(6):rotate(90, 0, 0)
local axle = cylinder(0.3, 1):rotate(90, 0, 0) | box(0.12, 0.1, 1):translate(0, 0.3, 0)

-- Blended where teeth and disc are thicker than the gear: its faces stay flat.
local gear = union { disc, cogs, k = 0.08 } & box(3, 3, 0.3)

local iron = material { name = "iron", color = {0.35, 0.33, 0.32}, specular = 0.5, shininess = 40 }
part("gear", (gear - spokes - axle):paint(iron))

camera { from = {2.5, 2, 6}, to = {0, 0, 0}, fov = 45 }
directional_light { direction = {1, 1.5, 2} }
ambient(0.2)
background({0.75, 0.73, 0.7})
