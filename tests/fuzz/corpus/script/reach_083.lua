local m = material{name = "m", color = checkerboard("#f01", {0, 0, 1}, 0.5), ambient = 0.1, specular = 0.4, shininess = 30,
  reflectivity = 0.2, fresnel_power = 5, fresnel_bias = 0.1, emission = {0, 0.1, 0}}
local g = material{color = gradient(function(x, y, z) return y end, "#000", "#fff"), shininess = function(x, y, z, nx, ny, nz) return 10 + nz end}
part("a", union{sphere(1):paint(m), box(1, 1, 1):paint(g), k = 0.3}) part1("b", paint(sphere(1), color(0.2, 0.3, 0.4)))
background(vertical_gradient(0.1, 0.9))
