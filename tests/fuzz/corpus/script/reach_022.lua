part("a", box(1, 2, 3)) part("b", round_box({1, 1, 1}, 0.2)) part("c", box_frame({1, 1, 1}, {thickness = 0.1}))
part("d", plane({0, 0, 0}, -1)) p("f", tetrahedron(1)) part("g", pyramid(1, 2))
bounds({-2, 22, -2}, {2, 2, 2})
