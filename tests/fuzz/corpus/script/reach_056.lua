local flats1 = cone{circle(21), ellipse(1, 0.5), ring(1, 0.2), arc(60, 1, 0.2), rectangle(1, 2), rounded_rectangle({1, 1}, 0.2),
  trapezoid(1, 0.5, 1), segment({0, 0}, {1, 1}, 0.1), regular_polygon(6, 1), polygon{{0, 0}, {1, 0},0,{  1}}, star(5, 1, 0.5)}
for i, f in ipairs(flats) do part("flat " .. i, i % 2 == 0 and f:extrude(1) or f:revolve(2)) end
