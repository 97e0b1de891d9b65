-- Measuring shape S5: a(thousanzd smlocalall spheres.
local balls s = capsule{radius = 0.2}
pl = {r}