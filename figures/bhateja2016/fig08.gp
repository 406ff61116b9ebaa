# Fig. 8: both forms of Table III fitted past the peak, on linear (a) and logarithmic (b) axes, with
# the curves that the paper prints. Twice the T_z of Eq. 5 is fitted (inferred, see Table III).
load 'style.gp'
set multiplot
set tmargin at screen 0.965
set bmargin at screen 0.135
set xlabel '{/:Italic W} = {/:Italic V}_p^2 / ({/:Italic d g})'
set ylabel '2{/:Italic T}_z / ({/:Italic m V}_p^2),   {/:Italic T}_z by Eq. (5)' offset 0.5

curve(who, s, form) = (strcol(curves_curve) eq who && strcol(curves_system) eq systems[s] && strcol(curves_model) eq form) \
                      ? column(curves_W) : NaN
height(n) = column(curves_T_z_twice_scaled)
# The rough systems stand second and fourth in `systems`.
do for [panel = 1:2] {
  set lmargin at screen (panel == 1 ? 0.085 : 0.585)
  set rmargin at screen (panel == 1 ? 0.475 : 0.975)
  set label 1 (panel == 1 ? '(a)' : '(b)') at graph 0.04, 0.94
  if (panel == 1) {
    set xrange [0:95]
    set yrange [0:*]
    set key at graph 0.97, 0.985 right top Left reverse font ',11' samplen 2.5
  } else {
    set logscale xy
    set xrange [1:100]
    set yrange [0.04:1]
    set xtics (1, 2, 5, 10, 20, 50, 100)
    set ytics (0.05, 0.1, 0.2, 0.5, 1)
    unset key
  }
  plot for [s = 2:4:2] points using (steady(s, column(points_W))):(column(points_T_z_twice_scaled)):(column(points_T_z_twice_scaled_se)) \
         with yerrorbars pointtype filled[s] pointsize 0.7 linecolor rgb colours[s] linewidth 1 title systems[s], \
       for [s = 2:4:2] points using (marked(s, column(points_W))):(column(points_T_z_twice_scaled)):(column(points_T_z_twice_scaled_se)) \
         with yerrorbars pointtype open[s] pointsize 0.9 linecolor rgb colours[s] linewidth 1, \
       for [s = 2:4:2] curves using (curve('fit', s, 'algebraic')):(height(0)) with lines linewidth 1.8 linecolor rgb blue, \
       for [s = 2:4:2] curves using (curve('fit', s, 'exponential')):(height(0)) with lines linewidth 1.8 linecolor rgb green, \
       for [s = 2:4:2] curves using (curve('reference', s, 'algebraic')):(height(0)) with lines linewidth 1.4 dashtype '-' linecolor rgb 'black', \
       for [s = 2:4:2] curves using (curve('reference', s, 'exponential')):(height(0)) with lines linewidth 1.4 dashtype '.' linecolor rgb 'black', \
       keyentry with points pointtype 6 pointsize 0.9 linecolor rgb grey title 'at rest or not stationary', \
       keyentry with lines linewidth 1.8 linecolor rgb blue title 'algebraic fit', \
       keyentry with lines linewidth 1.8 linecolor rgb green title 'exponential fit', \
       keyentry with lines linewidth 1.4 dashtype '-' linecolor rgb 'black' title 'paper, algebraic (Table III)', \
       keyentry with lines linewidth 1.4 dashtype '.' linecolor rgb 'black' title 'paper, exponential (Table III)'
}
unset multiplot
