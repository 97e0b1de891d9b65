-- Measuring shape S7: S6 off the lattice.
return (torus(1.2, 0.05):rotate(90, 0, 0) | box(1.5, 1.5, 0.01)):translate(0.0137, 0.0213, 0.0311)
