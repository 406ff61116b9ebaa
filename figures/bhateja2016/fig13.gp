# Fig. 13: as Fig. 12, at higher W. Temperatures by Eq. (5), in boxes one
# diameter deep, lab frame; boxes with a thousandth of the grains or more are drawn.
load 'style.gp'
load 'series.gp'
set multiplot
set tmargin at screen 0.965
set bmargin at screen 0.145
set xlabel '{/:Italic z} / {/:Italic d}'
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
do for [panel = 1:2] {
  rpm = speeds[panel]
  set lmargin at screen 0.075 + 0.48 * (panel - 1)
  set rmargin at screen 0.075 + 0.48 * (panel - 1) + 0.41
  set ylabel (panel == 1 ? '{/:Italic T}_z({/:Italic z}) / ({/:Italic m g d})' : '') offset 0.5
  set label 1 names[panel] at graph 0.30, 0.95
  plot for [k = 1:n] boxes using (here(steady_of(boxes_N, word(list, k), boxes_state, column(boxes_z)))):(column(boxes_T_z)):(column(boxes_T_z_se)) \
         with yerrorlines pointtype shape(k) pointsize 0.5 linecolor rgb tone(k, n) linewidth 1.2 title '{/:Italic N} = ' . word(list, k), \
       for [k = 1:n] boxes using (here(marked_of(boxes_N, word(list, k), boxes_state, column(boxes_z)))):(column(boxes_T_z)) \
         with points pointtype open_shape(k) pointsize 0.7 linecolor rgb tone(k, n), \
       keyentry with points pointtype 6 pointsize 0.7 linecolor rgb grey title 'not stationary'
}
unset multiplot
