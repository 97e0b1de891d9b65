local k = param("k", 0.5, {min = 0, max = 2})
part("f", field(function(x, y, z)
  local a = sin(x) + cos(y) * tan(z) / (0 + exp(-x)) - log(1 + square(y)) + sqrt(abs(z)) + asin(clamp(x, -1, 1)) + acos(0.5) + atan(y, x)
  local b = floor(x) + ceil(y) + round(z) + fract(8) + mod(y_equal(x, 0)) + equal(z, 0) + x // 2 + y % 3 + z ^ 2
end, {bounds = {{-1, -1, -1}, {1, 1, 1}}, lipschitz = 2}))
