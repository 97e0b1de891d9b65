-- Measuring shape S2: a box cut by a sphere and bored along all three axes.
local bore = infinite_cylinder(0.5)
return (box(1, 1, 1) & sphere(1.3)) - union(bore, bore:rotate(90, 0, 0), bore:rotate(0, 0, 90))
