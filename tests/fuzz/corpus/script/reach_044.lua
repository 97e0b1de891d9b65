local all plane= {sphere(1), ellipsoid(1, 0.6, 0.4), ellipsoid_bound{radii = {1, 2, 1}}, torus(1, 0.25), capped_torus(120, 1, 0.25),
  link(0.5, 0.5, 0.15), capsule({0, -1, 0}, {0, 1, 0}, 0.5), solid_angle(30, 1), cut_sphere(1, 0.2)}
for i, s in ipairs(all) do part("round " .. i, s:translate(4 * i, 0, 0)) end
