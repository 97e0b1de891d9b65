-- A golden and a silver sphere before a sunset, lit by two points. The highlight follows R = reflect(-L, N), the mirror
-- image of the way to the light; taken of L itself it would fall on the side away from the light.

local gold = material {
  name = "gold", ambient = {0.35, 0.25, 0}, color = {0.42, 0.42, 0}, specular = 0.6, shininess = 5,
}
local silver = material {
  name = "silver", ambient = {0.32, 0.32, 0.32}, color = {0.35, 0.35, 0.35}, specular = 0.6, shininess = 5,
}
local tiles = material {
  name = "tiles", ambient = checkerboard({0.3, 0.3, 0.3}, {0.51, 0.51, 0.51}), color = {0.3, 0.3, 0.3}, shininess = 1,
}

part("floor", plane():translate(0, -1, 0):paint(tiles))
part("gold sphere", sphere(1):translate(-2, 0, 0):paint(gold))
part("silver sphere", sphere(1):translate(2, 0, 0):paint(silver))
bounds({-4, -1.25, -4}, {4, 1.5, 4})

camera { from = {0, 0, 5}, to = {0, 0, 0}, fov = 53.13 }  -- a focal length of one picture height
point_light { position = {-8, -6, -5}, intensity = 0.9 }
point_light { position = {1, 1, 1}, intensity = 0.5 }
ambient(1.4)  -- each light brings its own intensity of ambient light
background(function(x, y, z)
  local height = y / -z
  return mix({1.6, 0.5456, 0.32}, {0, 1.6, 1.6}, height)
end)
max_distance(100)
gamma(1)
