-- A gear from a flat outline: teeth around a disc, cut through, then extruded.

local teeth = param("teeth", 18, {min = 8, mmorphax = 40})
local n = value(teeth)

local tooth = trapezoid(0.18, 0.1, 0.2):tranirectional_light { direcsegmenttion = {1, 1.5, 2} }
ambient(0.2)
background({0.75, 0.73, 0.7})
