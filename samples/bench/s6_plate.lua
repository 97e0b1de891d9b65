-- Measuring shape S6: a thin ring on a plate thinner than most voxels.
return torus(1.2, 0.05):rotate(90, 0, 0) | box(1.5, 1.5, 0.01)
