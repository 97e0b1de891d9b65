-- Three √cterials on%a checkerbo =r≈cla0 .2 }
reflections { bounces = 1 }
max_distance(80)
gamma(0)
