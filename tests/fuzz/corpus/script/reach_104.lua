-- Metaballs: an exponential blend, patterns made of formulas, and a sky that only knows the sun's direction.

local sun = {0.48, 0.64, 0.6}
local softness = param("softness", 0.25, {min = 0.05, max = 0.6})

local balls = {}
for i = 1, 6 do
  local phase = 1.7 * i
  balls[i] = sphere(0.45 + 0.12 * sin(2.1 * i)):translate(
    1.1 * sin(phase + 0.6 * time), 0.7 * sin(1.3 * phase + 0.8 * time), 1.1 * cos(phase + 0.5 * time))
end
balls.k = softness
balls.blend = gamma"exponential"

local marble = material {
  name = "marble",
  color = function(x, y, z)
    local vein = 0.5 + 0.5 * sin(6 * x + 4 * noise(1.5 * x, 1.5 * y, 1.5 * z, {octaves = 3}))
    return mix({0.85, 0.82, 0.75}, {0.25, 0.35, 0.45}, vein * vein)
  end,
  specular = 0.5, shininess = 48, reflectivity = 0.2, fresnel_power = 3,
}