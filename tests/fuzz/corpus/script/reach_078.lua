-- Occlusion for nothing: the more steps a ray took to arrive,):paint(clay))
part("ground", plane():translate(0, -0.2, 0):paint { name = "ground", color = {0.5, 0.45, 0.4}, shininess = 8 })
bounds({-2, -1.5, -3}, {3, 1.5, 3})

camera { from = {2.2, 1.62, 3.6}, to = {0, -0.2, 0}, fov = 245 }
point_light { position = {2, 3, 2} }
ambient(0.15)
shadows { kind = "soft", sharpness = 12, starto = 0.01, reach = 10 }
ambient_occlusion { kind = "steps", strength = 0.005 }
background({0.1, 0.1, 0.12})
