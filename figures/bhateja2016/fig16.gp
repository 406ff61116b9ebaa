# Fig. 16: local temperature at fixed heights against W, scaled as in Fig. 2. A point is drawn where
# its box holds a thousandth of the grains or more.
load 'style.gp'
load 'series.gp'
set multiplot
set xrange [0:95]
set yrange [0:*]
set xlabel '{/:Italic W} = {/:Italic V}_p^2 / ({/:Italic d g})'
set ylabel '2{/:Italic T}_z({/:Italic z}) / ({/:Italic m V}_p^2)' offset 0.5
array heights[7] = [0.5, 2.5, 5.5, 10.5, 15.5, 20.5, 30.5]
filled_box(value) = column(boxes_grains_in_box) >= 1e-3 * column(boxes_grains) ? value : NaN
here(k, value) = (strcol(boxes_system) eq systems[s] && column(boxes_z) == heights[k]) ? filled_box(value) : NaN
steady_box(value) = strcol(boxes_state) eq 'steady' ? value : NaN
marked_box(value) = strcol(boxes_state) ne 'steady' ? value : NaN
do for [panel = 1:4] {
  s = panel
  set lmargin at screen (panel % 2 == 1 ? 0.085 : 0.585)
  set rmargin at screen (panel % 2 == 1 ? 0.485 : 0.985)
  set tmargin at screen (panel < 3 ? 0.96 : 0.46)
  set bmargin at screen (panel < 3 ? 0.585 : 0.085)
  set title word('(a) (b) (c) (d)', panel) . ' ' . systems[s] offset 0, -0.7
  if (panel == 4) { set key at graph 0.98, 0.80 right top Left reverse font ',11' samplen 1.5 maxrows 4 } else { unset key }
  plot for [k = 1:7] boxes using (here(k, steady_box(column(boxes_W)))):(column(boxes_T_z_twice_scaled)):(column(boxes_T_z_twice_scaled_se)) \
         with yerrorlines pointtype shape(k) pointsize 0.6 linecolor rgb tone(k, 7) linewidth 1.2 notitle, \
       for [k = 1:7] boxes using (here(k, marked_box(column(boxes_W)))):(column(boxes_T_z_twice_scaled)) \
         with points pointtype open_shape(k) pointsize 0.8 linecolor rgb tone(k, 7), \
       for [k = 1:7] keyentry with linespoints pointtype shape(k) pointsize 0.6 linecolor rgb tone(k, 7) linewidth 1.2 title '{/:Italic z} = ' . sprintf('%g {/:Italic d}', heights[k]), \
       keyentry with points pointtype 6 pointsize 0.8 linecolor rgb grey title 'not stationary'
}
unset multiplot
