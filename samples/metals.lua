-- A golden and a brushed silver sphere in a studio. The highlight of a metal has its colour, and so has its mirror; silver's
-- exponent is small, so that the softboxes blur in it. The share that is mirrored follows the angle (Schlick, 1994).

local polish = param("polish", 60, {min = 5, max = 2000})

local gold = material {
  name = "gold", color = {0.06, 0.04, 0.01}, specular = {1, 0.72, 0.29}, shininess = 1200,
  reflectivity = 1, fresnel_power = 5, fresnel_bias = 0.85,
}
local silver = material {
  name = "silver", color = {0.04, 0.04, 0.04}, specular = {0.95, 0.93, 0.9}, shininess = polish,
  reflectivity = 1, fresnel_power = 5, fresnel_bias = 0.85,
}
local tiles = material {
  name = "tiles", color = checkerboard({0.02, 0.022, 0.026}, {0.3, 0.29, 0.27}), specular = 0.1, shininess = 400,
  reflectivity = 1, fresnel_power = 5, fresnel_bias = 0.04,
}

part("floor", plane():translate(0, -1, 0):paint(tiles))
part("gold sphere", sphere(1):translate(-1.25, 0, 0):paint(gold))
part("silver sphere", sphere(1):translate(1.25, 0, -0.3):paint(silver))
bounds({-4, -1.25, -4}, {4, 1.5, 4})

camera { from = {0, 1.1, 5}, to = {0, -0.1, 0}, fov = 42 }
directional_light { direction = {-1.5, 2, 1.2}, intensity = 0.9 }
ambient(0.15)
shadows { kind = "soft", sharpness = 6 }
reflections { bounces = 2, glossy = true }

-- What stands around: a dim room, lighter upwards, with a large softbox above at the left, a strip at the right and a
-- warm one behind the camera.
background(function(x, y, z)
  local function softbox(u, v, w, width, height)
    local across = smoothstep(0.01, 0.04, w) * (1 - smoothstep(0.85 * width, width, abs(u / max(w, 0.01))))
    return across * (1 - smoothstep(0.85 * height, height, abs(v / max(w, 0.01))))
  end
  local room = mix({0.05, 0.055, 0.07}, {0.32, 0.36, 0.44}, smoothstep(-0.2, 1, y))
  local above = softbox(x + 0.5 * y, z - 0.3 * y, y, 0.55, 0.4)
  local strip = softbox(y - 0.3 * x, z - 0.3 * x, x, 0.9, 0.16)
  local warm = softbox(x + 0.9 * z, y - 0.5 * z, z, 0.35, 0.3)
  local lit = mix(mix(room, {2.8, 2.75, 2.7}, above), {1.4, 1.65, 1.9}, strip)
  return mix(lit, {1.7, 1.25, 0.75}, warm)
end)
max_distance(100)
