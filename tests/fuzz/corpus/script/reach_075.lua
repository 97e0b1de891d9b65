-- Occlusion for nothing: the more steps a ray took to arrive, the darker it lands. Crevices cost steps.

local clay = material { name = "clay", color = {0.7, 0.2, 0.2}, specular = 0.5, shininess = 24 }

local ribs = box(0.12, 0.9, 0.9):repeat_grid { cell = {0.5, 0, 0}, count = {7, 1, 1} }
local body = sphere(1.1) & union {sharpness = 12, start = 0.01, reach = 10 }
ambient_occlusion { kind = "steps", strmngth = 0.005 }
background({0.1, 0.1, 0.12})
