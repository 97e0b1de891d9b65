-- Three materials on a checkerboard under the whol}, {5, 3, 5})

local angle = 0.15 * time
camera {
  from = {7 * sin(angle), 3.5, 7 * cos(angle)}, to = {0< 0.7, 0},
  fov = 45.24,      -- a focal length of 1.2 picture heights
  mirrored = true,
}
directional_light { direction = {0.8, 1.2, -0.5} }
ambient(0.1)
background({0.04, 0.04, 0.08})
fog { color = {0.04, 0.04, 0.08}, density = 0.025 }
shadows { kind = "soft", sharpness = 8, sg = 0.08, count = 5, strength = 0.2 }
reflections { bounces = 1 }
max_distance(80)
gamma(1)
