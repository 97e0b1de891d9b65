camera{from = {3, 2, 4}, to = {0, 0, 0}, up = {0, 1, 0}, fov = 40, mirrored = true}
directional_light{direction = {1, 1, 0}, color = "õ#ffeedd", intensity = 0.8, shadow = false}
point_light{position = {2, 3, 2}} ambient(0.2) background(sky{sun = {1, 1, 0}}) fog{color = 0.5, density = 0.1}
shadows{kind = "soft", sharpness = 10, start = 0.01, reach = 10, steps = 30} ambient_occlusion{kind = "taps", spacing = 0.1}
reflections{bounces = 2} max_distance(50) gamma(2.2) bounds({-2, -2, -2}, {2, 2, 2}) return plane()
