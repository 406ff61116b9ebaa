# Fig. 15: packing fraction of the beds of Fig. 14. In boxes one diameter deep,
# lab frame; boxes with a thousandth of the grains or more are drawn.
load 'style.gp'
load 'series.gp'
set multiplot
set tmargin at screen 0.93
set bmargin at screen 0.145
set xlabel '{/:Italic z} / {/:Italic d}'
set xrange [0:*]
set yrange [0:*]
set key at graph 0.97, 0.97 right top Left reverse font ',11' samplen 1.5
list = ' '
stats boxes using (note(sprintf('%.3g', column(boxes_W)))) nooutput
n = words(list)
filled_box(value) = column(boxes_grains_in_box) >= 1e-3 * column(boxes_grains) ? value : NaN
here(value) = strcol(boxes_system) eq systems[s] ? filled_box(value) : NaN
of_W(k, value) = sprintf('%.3g', column(boxes_W)) eq word(list, k) ? value : NaN
steady_box(value) = strcol(boxes_state) eq 'steady' ? value : NaN
marked_box(value) = strcol(boxes_state) ne 'steady' ? value : NaN
do for [panel = 1:2] {
  s = panel + 2
  set lmargin at screen 0.095 + 0.48 * (panel - 1)
  set rmargin at screen 0.495 + 0.48 * (panel - 1)
  set ylabel (panel == 1 ? 'φ({/:Italic z})' : '') offset 0.5
  set title (panel == 1 ? '(a) ' : '(b) ') . systems[s] offset 0, -0.7
  plot for [k = 1:n] boxes using (here(of_W(k, steady_box(column(boxes_z))))):(column(boxes_phi)):(column(boxes_phi_se)) \
         with yerrorlines pointtype shape(k) pointsize 0.5 linecolor rgb tone(k, n) linewidth 1.2 title '{/:Italic W} = ' . word(list, k), \
       for [k = 1:n] boxes using (here(of_W(k, marked_box(column(boxes_z))))):(column(boxes_phi)) \
         with points pointtype open_shape(k) pointsize 0.7 linecolor rgb tone(k, n), \
       keyentry with points pointtype 6 pointsize 0.7 linecolor rgb grey title 'not stationary'
}
unset multiplot
