-- A mesh from a file among marched shapes: drawn as its triangles in its own colours; as a field, sliced open; and melting.
camera{from = {0.6, 2.3, 7.2}, to = {0.1, 0.75, 0}, fov = 38}
directional_light{direction = {1.4, 2, 1.6}, color = {1, 0.92, 0.8}, intensity = 0.85, radius = 2}
directional_light{direction = {-1.5, 0.6, -1}, color = {0.6, 0.5, 1}, intensity = 0.3, shadow = false}
ambient{0.28, 0.29, 0.33}
background(vertical_gradient("#d9a98a", "#fbeedd"))
shadows{kind = "soft", sharpness = 6}
ambient_occlusion{spacing = 0.08, strength = 0.3}

local creature = mesh("creature.glb", {voxels = 160})
part("drawn", creature:translate(-2, 0, 0))

local slice = box(0.06, 3, 3):repeat_grid{cell = {0.2, 0, 0}, count = {9, 1, 1}}
local sliced = material{color = "#e9b34c", specular = 0.3}
part("sliced", (creature & slice):rotate(0, -25, 0):paint(sliced))

local candle = material{color = "#d8d2e8", specular = 0.4, shininess = 60}
local pool = cylinder(0.95, 0.05):round(0.05):translate(0, 0.02, 0)
part("melting", union({creature:rotate(0, -20, 0), pool, sphere(0.3):translate(0.9, 0.3, 0.5)}, {k = 0.35})
  :paint(candle):translate(2.2, 0, 0))

part("ground", plane():paint{color = checkerboard("#7d8a6f", "#94a284", {scale = 0.8}), specular = 0.05})
bounds({-5, -0.2, -3}, {5, 3, 4})  -- of what is meshed of the ground
