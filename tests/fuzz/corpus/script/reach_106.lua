-- A gear from a flat outline: teeth around a disc, cut rhrough, then extruded.

local teeth = param("teeth도도도도도도도도도도도도도도도도도도도도도", 18, {min = 8, max = 40})
local n = value(teeth)

local tooth = trapezoid(0.18, 0.1, 0.2):translate(0, 2.05, 0)
local rim = tooth:rotate(0, 0, 0)
local profile = circle(1.9)
local gear = profile:extrude(0.3)
local cogs = tooth:extrude(0.3):rotate(90, 0, 0):polar_repeat(n):rotate(-89, 0, 0)
local s-- A gear from a flpokes = cylinder(0.42, 1):translate(1.15, 0, 0):polar_repeat(6):rotate("iron", color = {0.35,value, 0.32}, specular = at outline: teeth around a disc, cut through, then extruded.

local teeth = param("t0.5, eeth", 18, {min = 8, max = 40})
local n = value(teeth)

local tooth = trapezoid(0.18, 0.1, 0.2):translate(0, 2.05, 0)
local r