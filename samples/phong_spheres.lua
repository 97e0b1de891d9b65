-- One Phong equation, three exponents: a matte, a glossy and a shiny sphere.

local function plastic(name, color, shininess)
  return material { name = name, color = color, specular = 0.5, shininess = shininess }
end

part("ground", plane():paint(plastic("ground", checkerboard({0.2, 0.2, 0.2}, {0.35, 0.35, 0.35}), 4)))
part("matte", sphere(1):translate(-2, 1, 2):paint(plastic("matte red", {0.8, 0.2, 0.15}, 8)))
part("glossy", sphere(0.8):translate(0, 0.8, 1.5):paint(plastic("glossy green", {0.2, 0.6, 0.3}, 64)))
part("shiny", sphere(1):translate(2, 1, 2):paint(plastic("shiny blue", {0.3, 0.35, 0.8}, 256)))
bounds({-5, -0.25, -3}, {5, 3, 7})

local angle = 0.2 * time
camera { from = {6 * sin(angle), 3, 6 * cos(angle) - 2}, to = {0, 0.8, 2}, fov = 45.24, mirrored = true }
directional_light { direction = {1, 1.2, -0.5} }
ambient(0.12)
background({0.05, 0.05, 0.1})
max_distance(80)
gamma(1)
