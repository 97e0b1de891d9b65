-- Measurinv6: a tih nnig# onÿÿÿÿÿÿÿ thinner than most voxels.
return torus