# Fig. 9: T_z against W when one parameter is changed; scaled as in Fig. 2.
load 'style.gp'
load 'series.gp'
set datafile missing  # a line ends at a point that is missing or not steady
set multiplot
set xrange [0:145]
set yrange [0:*]
set xlabel '{/:Italic W} = {/:Italic V}_p^2 / ({/:Italic d g})'
set ylabel '2{/:Italic T}_z / ({/:Italic m V}_p^2)' offset 0.5
set key at graph 0.97, 0.97 right top Left reverse font ',11' samplen 1.5

do for [panel = 1:4] {
  if (panel == 1) { file = stiffness; c = stiffness_k_n_set; W = stiffness_W; y = stiffness_T_z_twice_scaled; se = stiffness_T_z_twice_scaled_se; state = stiffness_state; name = '(a)'; what = '{/:Italic k}_n = ' }
  if (panel == 2) { file = restitution; c = restitution_e_p; W = restitution_W; y = restitution_T_z_twice_scaled; se = restitution_T_z_twice_scaled_se; state = restitution_state; name = '(b)'; what = '{/:Italic e}_p = ' }
  if (panel == 3) { file = friction; c = friction_mu_p; W = friction_W; y = friction_T_z_twice_scaled; se = friction_T_z_twice_scaled_se; state = friction_state; name = '(c)'; what = 'μ_p = ' }
  if (panel == 4) { file = layers; c = layers_N; W = layers_W; y = layers_T_z_twice_scaled; se = layers_T_z_twice_scaled_se; state = layers_state; name = '(d)'; what = '{/:Italic N} = ' }
  set lmargin at screen (panel % 2 == 1 ? 0.10 : 0.60)
  set rmargin at screen (panel % 2 == 1 ? 0.485 : 0.985)
  set tmargin at screen (panel < 3 ? 0.985 : 0.485)
  set bmargin at screen (panel < 3 ? 0.585 : 0.085)
  set label 1 name at graph 0.04, 0.94
  # A single layer is a hundred times as hot as twenty.
  if (panel == 4) { set logscale y; set yrange [0.005:200]; set key at graph 0.93, 0.97 maxrows 6 width -10 font ',10'; set format y '10^{%T}' }
  list = ' '
  stats file using (note(strcol(c))) nooutput
  n = words(list)
  plot for [k = 1:n] file using (of_series(c, word(list, k), column(W))):(if_steady(state, column(y))):(column(se)) \
         with yerrorlines pointtype shape(k) pointsize 0.6 linecolor rgb tone(k, n) linewidth 1.2 title what . word(list, k), \
       for [k = 1:n] file using (marked_of(c, word(list, k), state, column(W))):(column(y)):(column(se)) \
         with yerrorbars pointtype open_shape(k) pointsize 0.9 linecolor rgb tone(k, n) linewidth 1.2, \
       keyentry with points pointtype 6 pointsize 0.9 linecolor rgb grey title 'at rest or not stationary'
}
unset multiplot
