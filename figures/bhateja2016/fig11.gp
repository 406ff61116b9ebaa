# Fig. 11: the solid line changes W at A = d; each dashed line keeps W and lowers A/d from 1 to 0.1.
# The abscissa is W for the solid line alone; as in the paper, dashed lines are laid out from the
# point they start at, one step to the right for each tenth of A/d, with A/d beside the points.
load 'style.gp'
set lmargin at screen 0.105
set rmargin at screen 0.98
set xrange [4.2:11.2]
set yrange [0.9:1.95]
set xtics 4, 1, 9
set xlabel '{/:Italic W} of the solid line; along dashed lines {/:Italic A}/{/:Italic d} falls to the right'
set ylabel '{/:Italic T}_z / ({/:Italic m g d}),   by Eq. (5)' offset 0.3
set key at graph 0.985, 0.04 right bottom Left reverse samplen 2.5
steady_point(value) = strcol(points_state) eq 'steady' ? value : NaN
marked_point(value) = strcol(points_state) ne 'steady' ? value : NaN
along(n) = column(points_W) + 3 * (1 - column(points_A))
at_W(n, W) = abs(column(points_W) - W) < 0.001 ? along(0) : NaN
array starts[3] = [4.52, 5.58, 8.04]
plot points using (column(points_A) == 1 ? steady_point(column(points_W)) : NaN):(column(points_T_z)):(column(points_T_z_se)) \
       with yerrorlines pointtype 7 linewidth 1.8 linecolor rgb blue title '{/:Italic A} = {/:Italic d}', \
     for [k = 1:3] points using (steady_point(at_W(0, starts[k]))):(column(points_T_z)):(column(points_T_z_se)) \
       with yerrorlines pointtype 5 pointsize 0.7 dashtype '-' linewidth 1.2 linecolor rgb vermillion title (k == 1 ? '{/:Italic W} constant' : ''), \
     for [k = 1:3] points using (at_W(0, starts[k])):(column(points_T_z)):(sprintf('%g', column(points_A))) \
       with labels offset 0, 0.9 font ',10' textcolor rgb grey, \
     points using (marked_point(along(0))):(column(points_T_z)) with points pointtype 4 linecolor rgb grey, \
     keyentry with points pointtype 4 linecolor rgb grey title 'at rest or not stationary'
