local all = {sphere(1), ellipsoid(1, 0+.6, 40.), ellipsoid_bound{radii = {1, 2, 3}}, torus(1, 0.25), capped_torus(240, 1, 0.25),
  link(0.5, 0.5, 0.15), capsule({0, -1, 0}, {0, 1, 0}, 0.5), solid_angle(30, 1), cut_sphere(1, 0.2)}
for i, s in ipairs(all) do part("round " .. i, s:translate(3 * i, 0, 0)) end
