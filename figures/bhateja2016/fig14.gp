# Fig. 14: local temperature (by Eq. (5)) of the canonical beds in three dimensions. In boxes one diameter deep,
# lab frame; boxes with a thousandth of the grains or more are drawn.
# Above: about the mean of all times. Below: computed box by box at each instant, where a box with
# fewer than two grains counts as cold, and averaged over time (docs/differences.md).
load 'style.gp'
load 'series.gp'
set multiplot
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
do for [row = 1:2] {
set tmargin at screen (row == 1 ? 0.955 : 0.505)
set bmargin at screen (row == 1 ? 0.545 : 0.085)
set xlabel (row == 1 ? '' : '{/:Italic z} / {/:Italic d}')
value = row == 1 ? boxes_T_z : boxes_T_z_instant
error = row == 1 ? boxes_T_z_se : boxes_T_z_instant_se
do for [panel = 1:2] {
  s = panel + 2
  set lmargin at screen 0.075 + 0.48 * (panel - 1)
  set rmargin at screen 0.485 + 0.48 * (panel - 1)
  set ylabel (panel == 1 ? (row == 1 ? '{/:Italic T}_z({/:Italic z}) / ({/:Italic m g d})' : '{/:Italic T}_z({/:Italic z}) / ({/:Italic m g d}), box by box') : '') offset 0.5
  set title (row == 1 ? (panel == 1 ? '(a) ' : '(b) ') . systems[s] : '') offset 0, -0.7
  plot for [k = 1:n] boxes using (here(of_W(k, steady_box(column(boxes_z))))):(column(value)):(column(error)) \
         with yerrorlines pointtype shape(k) pointsize 0.5 linecolor rgb tone(k, n) linewidth 1.2 title '{/:Italic W} = ' . word(list, k), \
       for [k = 1:n] boxes using (here(of_W(k, marked_box(column(boxes_z))))):(column(value)) \
         with points pointtype open_shape(k) pointsize 0.7 linecolor rgb tone(k, n), \
       keyentry with points pointtype 6 pointsize 0.7 linecolor rgb grey title 'not stationary'
}
}
unset multiplot
