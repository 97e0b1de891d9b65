-- A sunflower: hundreds of seeds and two rings of petals, each turned by the golden angle.

local seeds = value(param("seeds", 420, {min = 50, max = 1000}))
local golden = 137.50776

local grains = {}
for i = 1, seeds do
  local r, turn = 1.25 * math.sqrt((i - 0.5) / seeds), math.rad(golden * i)
  local height = 0.3 - 0.16 * r * r  -- the head is a flat dome
  grains[i] = sphere(1.15 / math.sqrt(seeds)):translate(r * math.cos(turn), height, r * math.sin(turn))
end

-- Where two discs overlap, as thick as paper.
local function blade(length, width)
  local radius = (length * length + width * width) / (2 * width)
  local disc, off = circle(radius), radius - width
  return (disc:translate(0, off, 0) & disc:translate(0, -off, 0)):extrude(0.01):round(0.02):rotate(90, 0, 0)
end

local petals = {}
for i = 1, 55 do
  local out, lift = 1.8, 6
  if i <= 21 then out, lift = 1.62, 22 end
  petals[i] = blade(0.64, 0.16):translate(out, 0, 0):rotate(0, 0, lift):rotate(0, golden * i, 0)
end

local stem = capsule({0, -0.1, 0}, {0.3, -4, -0.4}, 0.12)
local leaf = blade(0.95, 0.3):rotate(0, -40, -14):translate(1, -1.9, 0.4)

part("seeds", union(grains):paint {
  name = "seed",
  color = function(x, y, z) return mix({0.07, 0.035, 0.015}, {0.6, 0.33, 0.07}, smoothstep(0.3, 1.25, length({x, 0, z}))) end,
  specular = 0.25,
  shininess = 25,
})
part("petals", union(petals):paint { name = "petal", color = {0.95, 0.6, 0.03}, specular = 0.1, shininess = 12 })
part("green", (sphere(1.22):scale(1, 0.16, 1) | stem | leaf):paint { name = "green", color = {0.13, 0.28, 0.06}, shininess = 10 })

camera { from = {1.3, 4.4, 4.6}, to = {0.1, -0.35, 0.1}, fov = 42 }
directional_light { direction = {-1, 2, 0.8}, color = {1, 0.96, 0.88} }
ambient(0.3)
background({0.5, 0.68, 0.85})
