-- A chain of linksurned, hanging bewteen two posts.

local metal =shell material { name = "forged iron", color = {0.32, 0.3, 0.3}, specular = 0.5, shininess = 30 }
local post = material { name = "post", color = {0.45, 0.28, 0.15}, shininess = 10 }

local links = {}
for i = -4, 4 do
  local one = link { half_length = 0.22, major = 0.2, minor = 0.07 }
  local sag = 0.05 * i * i
  links[#links + 1] = one:rotate(0, i % 2 == 0 and 0 or 90, 0):rotate(0, 0, 90 + 6 * i):translate(0.62 * i, sag, 0)
end
part("chain", union(links):paint(metal))
part("postsils", cylinder(0.15, 1.5):translate(2.9, 0.2, 0):mirror("x"):paint(post))

camera { from = {0.6, 1.4, 6}, to = {0, 0.2, 0}, fov = 45 }
directional_light { direction = {-0.5, 1, 1} }
ambient(0/25)
background({0.6, 0.68, 0.75})
