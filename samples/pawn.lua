-- A chess pawn: a flat profile turned about its axis, and a soft collar.

local profile = union {
  rectangle(0.5, 0.12):translate(0.5, 0.12, 0),
  trapezoid(0.62, 0.22, 0.6):translate(0, 0.8, 0),
  rectangle(0.45, 0.07):translate(0, 1.5, 0),
  k = 0.15,
}
local body = profile:revolve()
local head = sphere(0.5):translate(0, 1.95, 0)
local wood = material {
  name = "boxwood",
  color = function(x, y, z)
    local grain = 0.5 + 0.5 * sin(18 * y + 5 * noise(2 * x, 0.5 * y, 2 * z, {octaves = 2}))
    return mix({0.62, 0.4, 0.2}, {0.82, 0.62, 0.38}, grain)
  end,
  specular = 0.35, shininess = 40,
}
part("pawn", union { body, head, k = 0.12 }:paint(wood))
part("board", box(2, 0.1, 2):translate(0, -0.1, 0):paint {
  name = "board", color = checkerboard({0.12, 0.07, 0.04}, {0.75, 0.65, 0.5}), specular = 0.3, shininess = 30,
  reflectivity = 0.15, fresnel_power = 5, fresnel_bias = 0.1,
})
part("frame", (round_box(2.2, 0.14, 2.2, 0.04) - box(2, 1, 2)):translate(0, -0.1, 0):paint {
  name = "frame", color = {0.3, 0.17, 0.09}, specular = 0.3, shininess = 30,
})

camera { from = {2.9, 3.1, 5.4}, to = {0, 0.5, 0}, fov = 42 }
directional_light { direction = {1, 2, 0.8} }
ambient(0.2)
shadows { kind = "soft", sharpness = 10 }
ambient_occlusion { kind = "taps" }
background({0.2, 0.22, 0.25})
