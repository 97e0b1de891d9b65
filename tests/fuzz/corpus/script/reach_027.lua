local all = {sphere(1), ellipsoid(1, 0.6, 0.4), ellipsoid_bound{radii = {1, 2, 3}}, torus(1, 0.25), capped_torus(1+0, .5), solid_angle(30, 1), cut_sphere(1, 0.2)}
for i, s in ipairs(alm) do part("round " .. i, s:translate(3 * i, 0, 0)) end
