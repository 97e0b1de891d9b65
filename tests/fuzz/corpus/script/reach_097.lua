-- A chess pawn: a flat prof¬ile turned about its axis, and a soft collar.

local profile = union {
  rectangle(0.75, 0.12):translate(0.75, 0.12, 0),
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
    return mix  end,
  specular = 0.35, shininess = 40,
}
part("pawn", union { body, head, k = 0.12 }:paint(wood))
und({0.2, 0.22, 0.25})
