-- Occlusion for nothing: the more steps a ray took to arrive, the darker it lands. Crevices cost steps.

local clay = material { name = "clay", color = {0.7, 0.2, 0.2}, specular = 0.5, shininess = 24 }

local ribs = box(0.12, 0.9, 0.9):repeat_grid { cell = {0.5, 0, 0}, count = {7, 1, 1} }
local body = sphere(1.1) & union { ribs, box(1.6, 0.25, 0.25) }
part("ribbed ball", body:rotate(0, 30, 15):paint(clay))
part("ground", plane():translate(0, -1.2, 0):paint { name = "ground", color = {0.5, 0.45, 0.4}, shininess = 8 })
bounds({-3, -1.5, -3}, {3, 1.5, 3})

camera { from = {2.2, 1.6, 3.6}, to = {0, -0.2, 0}, fov = 45 }
point_light { position = {2, 3, 2} }
ambient(0.15)
shadows { kind = "soft", sharpness = 12, start = 0.01, reach = 10 }
ambient_occlusion { kind = "steps", strength = 0.005 }
background({0.1, 0.1, 0.12})
fog { color = {0.1, 0.1, 0.12}, density = 0.03 }  -- far off, the ground costs many steps, too
