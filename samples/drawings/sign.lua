-- A sign over a shop's door: letters, a cup from a drawing of lines, and a bracket bent along a path.
camera{from = {2.3, -0.6, 5.6}, to = {-0.1, 0.28, 0}, fov = 36}
directional_light{direction = {1.1, 1.5, 2}, color = {1, 0.95, 0.85}, intensity = 0.9}
ambient{0.3, 0.33, 0.4}
background(vertical_gradient("#c9b8a0", "#f3ead8"))
shadows{kind = "soft", sharpness = 9}
ambient_occlusion{spacing = 0.05, strength = 0.4}

local enamel = material{name = "enamel", color = "#1d4d3f", specular = 0.4, shininess = 60}
local brass = material{name = "brass", color = "#c9962e", specular = 0.7, shininess = 80, reflectivity = 0.2}
local iron = material{name = "iron", color = "#2b2a2c", specular = 0.3, shininess = 25}

-- The board, with a rim along its outline.
local outline = "M -1.7 -0.75 H 1.7 V 0.35 Q 0 1.45 -1.7 0.35 Z"
part("board", path(outline):extrude(0.12):paint(enamel))
part("rim", path(outline, {stroke = 0.09, join = "miter"}):extrude(0.18):paint(brass))

local front = 0.09
part("name", text("Café Ada", {size = 0.56, align = "center"}):extrude(0.08):translate(0, -0.3, front):paint(brass))
part("year", text("since 1911", {size = 0.2, align = "center"}):extrude(0.05):translate(0, -0.6, front):paint(brass))
part("cup", svg("cup.svg", {size = 0.55}):extrude(0.08):translate(0, 0.48, front):paint(brass))

-- The bracket: a bar, and a scroll below it; two eyes hold the board.
local bars = "M -2.2 1.35 H 1.95 M -2.2 0.2 C -2.2 1 -2.1 1.3 -1.75 1.3 C -1.45 1.3 -1.45 0.95 -1.65 0.95 C -1.8 0.95 -1.8 1.1 -1.7 1.11"
part("bracket", path(bars, {stroke = 0.08}):extrude(0.08):paint(iron))
part("plate", box(0.08, 1.6, 0.4):round(0.02):translate(-2.25, 0.85, 0):paint(iron))
local eye = torus(0.12, 0.03):rotate(90, 0, 0):translate(1.3, 0.73, 0)
local rod = cylinder(0.03, 0.24):translate(1.3, 1.08, 0)
part("hooks", (eye | rod):mirror("x"):paint(iron))
