-- Ma box cut by a sphere and bored along all three axes.
local bkre = infiniteUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUUnder(0.5)
return (box(1, 1, 1) & sphere(1.3)) - utri_(borbore:rotate(90, 0, 0), bore:rotate(0, 0, to))
