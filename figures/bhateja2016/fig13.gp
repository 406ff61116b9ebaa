# Fig. 13: as Fig. 12, at higher W. Temperatures by Eq. (5), in boxes one
# diameter deep, lab frame; boxes with a thousandth of the grains or more are drawn.
# Above: about the mean of all times. Below: computed box by box at each instant, where a box with
# fewer than two grains counts as cold, and averaged over time (docs/differences.md).
load 'style.gp'
load 'series.gp'
set multiplot
set xrange [0:*]
set yrange [0:*]
set key at graph 0.97, 0.97 right top Left reverse font ',11' samplen 1.5
list = ' '
stats boxes using (note(strcol(boxes_N))) nooutput
n = words(list)
filled_box(value) = column(boxes_grains_in_box) >= 1e-3 * column(boxes_grains) ? value : NaN
here(value) = strcol(boxes_frequency_rpm) eq rpm ? filled_box(value) : NaN
array speeds[2] = ['3500', '3900']
array names[2] = ['(a) {/:Italic W} = 68.5', '(b) {/:Italic W} = 85.0']
do for [row = 1:2] {
set tmargin at screen (row == 1 ? 0.955 : 0.505)
set bmargin at screen (row == 1 ? 0.545 : 0.085)
set xlabel (row == 1 ? '' : '{/:Italic z} / {/:Italic d}')
value = row == 1 ? boxes_T_z : boxes_T_z_instant
error = row == 1 ? boxes_T_z_se : boxes_T_z_instant_se
do for [panel = 1:2] {
  rpm = speeds[panel]
  set lmargin at screen 0.075 + 0.48 * (panel - 1)
  set rmargin at screen 0.075 + 0.48 * (panel - 1) + 0.41
  set ylabel (panel == 1 ? (row == 1 ? '{/:Italic T}_z({/:Italic z}) / ({/:Italic m g d})' : '{/:Italic T}_z({/:Italic z}) / ({/:Italic m g d}), box by box') : '') offset 0.5
  set title (row == 1 ? names[panel] : '') offset 0, -0.7
  plot for [k = 1:n] boxes using (here(steady_of(boxes_N, word(list, k), boxes_state, column(boxes_z)))):(column(value)):(column(error)) \
         with yerrorlines pointtype shape(k) pointsize 0.5 linecolor rgb tone(k, n) linewidth 1.2 title '{/:Italic N} = ' . word(list, k), \
       for [k = 1:n] boxes using (here(marked_of(boxes_N, word(list, k), boxes_state, column(boxes_z)))):(column(value)) \
         with points pointtype open_shape(k) pointsize 0.7 linecolor rgb tone(k, n), \
       keyentry with points pointtype 6 pointsize 0.7 linecolor rgb grey title 'not stationary'
}
}
unset multiplot
