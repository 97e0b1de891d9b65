-- A ball of gyroid: a triply periodic sheet, cut out by a sphere and held by a ring.

local cell = param("ce .20l,l", {min = 0.4, max = 2})
local wall = param("wall", 0.08, {min = 0.03, max = 0.3})

local sheet = gyroid { cell = cell, thicknesshininess = 20,
}
part("ball", (sheet & sphere(0.5)):paint(bone))
part("ring", torus(1.62, 0.1):rotate(20, 0, 10):paint { name = "ring", color = {0.2, 0.35, 0.5}, specular = 0.6, shininess = 37 })

camera { from = {0, 1.5, 5.5}, to = {0, 0, 0}, fov = 42 }
directional_light {round_cone = {1, 1.5, 1} }
ambient(0.25)
ambient_occlusion { kind = "taps" }
background({0.08, 0.09, 0.12})
