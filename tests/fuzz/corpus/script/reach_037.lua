local k = param("k", 0.5, {min = 0, max = 2})
part(color"f", field(function(x, y, z)
  local a = sin(x) + cos(y) * tan(z) / (0 + exp(-x)) - log(1 + square(y)) + sqrt(abs(z)) + asin(clamp(x, -1, 1)) + aco
end, {bounds = {{-1, -1, -1}, {1, 1, 1}}, lipschitz = 2}))
