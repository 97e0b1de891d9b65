-- A glazed mug: raised letters on its side, a handle that melts into the wall, coffee inside, on a wooden board.
camera{from = {2.3, 2.9, 4.2}, to = {0.15, 0.68, 0}, fov = 30}
directional_light{direction = {-1.2, 2.2, 1.6}, color = {1, 0.93, 0.82}, intensity = 0.85}
point_light{position = {4, 2.5, 2}, color = {0.5, 0.65, 1}, intensity = 0.22, shadow = false}
ambient{0.3, 0.33, 0.38}
background(vertical_gradient("#8d7f72", "#e6ded2"))
shadows{kind = "soft", sharpness = 7}
ambient_occlusion{spacing = 0.07, strength = 0.35}
reflections{bounces = 1}

local glaze = material {
  name = "glaze", color = "#1f6f78", specular = 0.55, shininess = 90,
  reflectivity = 0.45, fresnel_power = 4, fresnel_bias = 0.04,
}
local cream = material{name = "cream", color = "#f4e3c1", specular = 0.4, shininess = 60}
local coffee = material {
  name = "coffee", color = "#2a1206", specular = 0.5, shininess = 120,
  reflectivity = 0.35, fresnel_power = 2, fresnel_bias = 0.1,
}
local wood = material{name = "wood", shininess = 12, specular = 0.08, color = function(x, y, z)
  local grain = 0.5 + 0.5 * sin(26 * (z + 0.12 * noise(0.7 * x, 0, 2 * z, {octaves = 3})) + 2.5 * noise(0.9 * x, 1, 1.4 * z))
  return mix("#6b4022", "#a56b3b", grain)
end}

-- Strokes of letters, from and to points of a cell of 1 by 1.
local letters = {
  S = {
    {0.8, 0.85, 0.35, 0.95}, {0.35, 0.95, 0.15, 0.72}, {0.15, 0.72, 0.8, 0.32},
    {0.8, 0.32, 0.6, 0.05}, {0.6, 0.05, 0.15, 0.15},
  },
  D = {{0.18, 0, 0.18, 1}, {0.18, 1, 0.55, 0.9}, {0.55, 0.9, 0.8, 0.5}, {0.8, 0.5, 0.55, 0.1}, {0.55, 0.1, 0.18, 0}},
  F = {{0.2, 0, 0.2, 1}, {0.2, 1, 0.8, 1}, {0.2, 0.52, 0.65, 0.52}},
}
local function word(text, size)
  local strokes = {}
  for i = 1, #text do
    for _, s in ipairs(letters[string.sub(text, i, i)]) do
      local at = (i - 1 - #text / 2) * size
      strokes[#strokes + 1] = segment({at + s[1] * size, s[2] * size}, {at + s[3] * size, s[4] * size}, 0.035)
    end
  end
  return union(strokes)
end

local outer = cylinder(0.72, 0.8):round(0.06):translate(0, 0.86, 0)
local inner = cylinder(0.7, 0.8):round(0.04):translate(0, 0.98, 0)
local handle = torus(0.42, 0.1):rotate(90, 0, 0):scale(1, 1.15, 1):translate(0.82, 0.88, 0)
local wall = union(outer, handle, {k = 0.14}):difference(inner, {k = 0.05})
-- The word goes through the wall; a cylinder leaves what stands out of it.
local text = word("SDF", 0.42):extrude(0.4):translate(0, 0.62, 0.6) & cylinder(0.815, 0.7):translate(0, 0.86, 0)
part("mug", union(wall:paint(glaze), text:paint(cream):rotate(0, 22, 0) - inner))
part("coffee", cylinder(0.735, 0.02):translate(0, 1.38, 0):paint(coffee))
part("board", cylinder(2.2, 0.08):round(0.04):translate(0, -0.12, 0):paint(wood))
