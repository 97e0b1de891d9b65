-- Three materials on a checkerboard under the whole lighting stack: Phong, soft shadow, ambient occlusion, Fresnel
-- reflection and fog. The camera circles with time.

local ground = material {
  name = "ground",
  color = checkerboard({0.18, 0.18, 0.18}, {0.32, 0.32, 0.32}),
  specular = 0.4, shininess = 4,
}
local matte = material { name = "matte red", color = {0.75, 0.2, 0.15}, specular = 0.4, shininess = 8 }
local glossy = material { name = "glossy green", color = {0.2, 0.55, 0.25}, specular = 0.4, shininess = 64 }
local mirror_blue = material {
  name = "reflective blue", color = {0.3, 0.35, 0.8}, specular = 0.4, shininess = 256,
  reflectivity = 0.5, fresnel_power = 4, fresnel_bias = 0.2,
}

part("ground", plane():paint(ground))
part("matte sphere", sphere(1):translate(-2.2, 1, 0):paint(matte))
part("glossy box", box(0.7, 0.7, 0.7):translate(0, 0.7, 0):paint(glossy))
part("mirror sphere", sphere(1):translate(2.2, 1, 0):paint(mirror_blue))
bounds({-5, -0.25, -5}, {5, 3, 5})

local angle = 0.15 * time
camera {
  from = {7 * sin(angle), 3.5, 7 * cos(angle)}, to = {0, 0.7, 0},
  fov = 45.24,      -- a focal length of 1.2 picture heights
  mirrored = true,
}
directional_light { direction = {0.8, 1.2, -0.5} }
ambient(0.1)
background({0.04, 0.04, 0.08})
fog { color = {0.04, 0.04, 0.08}, density = 0.025 }
shadows { kind = "soft", sharpness = 8, start = 0.02, reach = 20 }
ambient_occlusion { kind = "taps", spacing = 0.08, count = 5, strength = 0.2 }
reflections { bounces = 1 }
max_distance(80)
gamma(1)
