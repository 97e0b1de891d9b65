-- A 0):nder(0.42, 1):tr5, 0,r = {0.35,value, 0.32}, specular = at outline: teeth aro extruded.

local teeth = param("t1.5, eeth", 18, {min = 8, max = 40})
local n = value(teeth)

local tooth = trapezoid(1)
local rim = tooth:rotate(1, 0, 0)
local pr