# Fig. 3: one snapshot of each bed when the base is highest. The cell is periodic: grains that reach
# over a side are drawn at both. Insets: T_z against W at low W, with the bed's own point.
load 'style.gp'
set multiplot
array rpm[3] = ['500', '550', '600']
array what[3] = ['below', 'just below', 'at']
set palette defined (0 '#472d7b', 0.35 '#2c728e', 0.7 '#28ae80', 1 '#fde725')
set cbrange [0:1.5]
set style fill solid 1 border rgb '#333333'
here(k, value) = strcol(grains_frequency_rpm) eq rpm[k] ? value : NaN
bed(k, value) = strcol(beds_frequency_rpm) eq rpm[k] ? value : NaN
do for [k = 1:3] {
  left = 0.05 + 0.295 * (k - 1)
  set lmargin at screen left + 0.01
  set rmargin at screen left + 0.265
  set tmargin at screen 0.93
  set bmargin at screen 0.12
  unset logscale
  unset grid
  set size ratio -1
  set xrange [0:10]
  set yrange [-1:22]
  set xtics 0, 5, 10
  set ytics 0, 5, 20
  set xlabel '{/:Italic x}/{/:Italic d}'
  set ylabel (k == 1 ? '{/:Italic z}/{/:Italic d}' : '') offset 1
  if (k == 3) { set colorbox user origin 0.925, 0.14 size 0.012, 0.7; set cblabel 'speed / {/:Italic V}_p' offset -0.8 } else { unset colorbox }
  stats grains using (here(k, column(grains_base_height))) nooutput name 'base'
  stats grains using (here(k, column(grains_W))) nooutput name 'W'
  set title sprintf('(%s)  {/:Italic W} = %.2f, %s {/:Italic W}_f', 'abc'[k:k], W_mean, what[k])
  set object 1 rectangle from 0, -1 to 10, base_mean fillcolor rgb '#BBBBBB' fillstyle solid noborder behind
  plot for [image = -1:1] grains using (here(k, column(grains_x) + 10 * image)):(column(grains_z)):(column(grains_radius)):(column(grains_speed)) \
         with circles fillcolor palette, \
       base_mean with lines linewidth 2 linecolor rgb 'black'
  unset object 1
  unset title
  unset colorbox
  set size noratio
  set lmargin at screen left + 0.10
  set rmargin at screen left + 0.235
  set tmargin at screen 0.90
  set bmargin at screen 0.77
  set xrange [0:6]
  set yrange [0:1.3]
  set xtics 0, 2, 6 font ',10'
  set ytics 0, 0.5, 1 font ',10'
  set xlabel '{/:Italic W}' font ',10' offset 0, 0.7
  set ylabel '2{/:Italic T}_z/({/:Italic m V}_p^2)' font ',10' offset 2
  plot curve using (column(curve_W)):(column(curve_T_z_twice_scaled)) with linespoints pointtype 7 pointsize 0.35 linecolor rgb grey, \
       beds using (bed(k, column(beds_W))):(column(beds_T_z_twice_scaled)):(column(beds_T_z_twice_scaled_se)) with yerrorbars pointtype 7 pointsize 1 linecolor rgb vermillion
  set xtics font ',14'
  set ytics font ',14'
  set xlabel font ',14' offset 0, 0
  set ylabel font ',14'
}
unset multiplot
