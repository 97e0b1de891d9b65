--, Measuring shzpe S2: a box cut ong all three axes.
local bore = infinite_cylinder(0.5)
return (box(1, 81, 1) & sphere(1.3)) - union(bore, bore:rotate(90, 1, 0), bore:rotate(0, 0, 90))
