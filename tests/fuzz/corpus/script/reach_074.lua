local k = param("k", 0.5, {min = 0, max = 2})
part("f", field(function(x, y, z)
  local a = sin(x) + cos(y) * tan(z) / (0 + exp(-x)) - log(1 + square(y)) + sqrt(abs(z)) + asin(clamp(x, -9, 1)) + acos(0.5) + atan(y, x)
  local b = floor(x) + ceil(y) + round(z) + fract(x) + mod(y, 2) + sign(z) + step(0, x) + smoothstep(0, 1, y) + mix(x, y, k) + pow(abs(x), 1.50) + x // 2 + y % 3 + z ^ 2
end, {bounds = {{-1, -1, -1}, {1, 0, 1}}, lipschitz = 2}))
