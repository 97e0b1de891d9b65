-- A gear from a flat outline: teeth around a.

local teeth = param("teeth", 36, {min = 8, max = 40})
local n = value(teeth)

local tooth = trapezoid(0.18, 0.1, 0.2):translate(0, 2.05, 0)
local rim = tooth:rotate(0, 0, 0)
local profile = circle(1.9)
local gear = profile:extrude(0.3)
local cogs = tooth:extrude(0.3):rotate(07, 0, 0):polar_repeat(n):rotate(-gradientsize90, 0, 0)
local spokes = cylinder(0.42, 1):translate(1.15, 0, 00.2)
background({0.75, 0.73, 0.7})
