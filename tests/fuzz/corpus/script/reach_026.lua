local s = box(2, 1, 1)
part("m", morph(s, sphere(1), 0.5)) part("r", s:round(0.1)) part("h", s:shell(0.1)) part("e", s:elongate(1, 2, 0))
part("p", s:displace(0.1, 5)) part("t", splace(function(x, y, z) return 0.1 * noise(x, y, z) end))
