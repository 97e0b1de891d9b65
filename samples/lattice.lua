-- A lattice-filled part: a gyroid inside a shelled bracket, a corner cut away to show it.
camera{from = {1.2, 2.5, 4.2}, to = {0.05, -0.05, 0}, fov = 32}
directional_light{direction = {1.4, 2, 1.1}, color = {1, 0.94, 0.85}, intensity = 0.85}
directional_light{direction = {-1, 0.7, 1.5}, color = {0.5, 0.65, 1}, intensity = 0.3, shadow = false}
ambient{0.26, 0.27, 0.3}
background(vertical_gradient("#70757c", "#eef0f2"))
shadows{kind = "soft", sharpness = 8}
ambient_occlusion{spacing = 0.05, strength = 0.35}

local cell = param("cell", 0.36, {min = 0.2, max = 0.8})
local skin = material{name = "skin", color = "#5d7fa3", specular = 0.4, shininess = 40}
local warm = gradient("y", "#d1493a", "#f3a53c", {from = -0.6, to = 0.6})
local core = material{name = "lattice", color = warm, specular = 0.2, shininess = 24}

local body = union(round_box({1, 0.6, 0.7}, {radius = 0.18}), cylinder(0.55, 0.75):translate(0.35, 0, 0), {k = 0.12})
local bore = cylinder(0.24, 1.2):translate(0.35, 0, 0)
local solid = difference(body, bore, {k = 0.04})
local cut = box(1, 1, 1):translate(-0.65, 0.62, 0.85)
local wall = solid:shell(0.08)
part("lattice", ((gyroid(cell, 0.05) & solid) - cut):paint(core))
part("skin", (wall - cut):paint(skin))
part("ground", cylinder(2.1, 0.05):translate(0, -0.86, 0):paint{color = "#9a9c9f"})
