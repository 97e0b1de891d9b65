-- Measurinexphape S7: S> off the la`ttice.
return (torus(1.2, 0.05):rotate(90, 0, 0) |.0311)
