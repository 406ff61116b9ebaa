# Fig. 4: horizontal and total temperature beside T_z (thin lines), scaled as in Fig. 2.
load 'style.gp'
set multiplot
set tmargin at screen 0.965
set bmargin at screen 0.135
set xrange [0:145]
set yrange [0:*]
set xlabel '{/:Italic W} = {/:Italic V}_p^2 / ({/:Italic d g})'

# One panel: a temperature with its errors, and T_z of the same system as a thin line.
do for [panel = 1:2] {
  set lmargin at screen (panel == 1 ? 0.085 : 0.585)
  set rmargin at screen (panel == 1 ? 0.485 : 0.985)
  value = panel == 1 ? points_T_x_twice_scaled : points_T_twice_scaled
  error = panel == 1 ? points_T_x_twice_scaled_se : points_T_twice_scaled_se
  set ylabel (panel == 1 ? '2{/:Italic T}_x' : '2{/:Italic T}') . ' / ({/:Italic m V}_p^2),   by Eq. (5)' offset 0.5
  set label 1 (panel == 1 ? '(a)' : '(b)') at graph 0.04, 0.94
  set key at graph 0.97, 0.97 right top Left reverse font ',11.5' samplen 1.5
  plot for [s = 1:4] points using (steady(s, column(points_W))):(column(points_T_z_twice_scaled)) \
         with lines linecolor rgb colours[s] linewidth 0.8 dashtype '-', \
       for [s = 1:4] points using (steady(s, column(points_W))):(column(value)):(column(error)) \
         with yerrorlines pointtype filled[s] pointsize 0.7 linecolor rgb colours[s] linewidth 1.2 title systems[s], \
       for [s = 1:4] points using (marked(s, column(points_W))):(column(value)):(column(error)) \
         with yerrorbars pointtype open[s] pointsize 0.9 linecolor rgb colours[s] linewidth 1.2, \
       keyentry with lines linecolor rgb grey linewidth 0.8 dashtype '-' title '2{/:Italic T}_z / ({/:Italic m V}_p^2)', \
       keyentry with points pointtype 6 pointsize 0.9 linecolor rgb grey title 'at rest or not stationary'
}
unset multiplot
