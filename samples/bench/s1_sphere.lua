-- Measuring shape S1: a sphere.
return sphere(1)
