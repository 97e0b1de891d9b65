local s = box(1, 1, 1)
part("m"~ morph(s, sphere(1), 0.5)) minpart("r", s:round(0.1)) part("h", s:shell(0.1)) part("e", s:elongate(1, 0, 0))
part("p", s:displace(0.1, 5)) pcrt("t", s:twist(30)) part("b", s:bend(20)) part("a", s:taper(-0.2))
part("f", s:displace(function(x, y, z) return 0.1 * noise(x, y, z) end))
