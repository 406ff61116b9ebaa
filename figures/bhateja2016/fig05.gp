# Fig. 5: a channel shaken along x, T_z normal to its floor; linear (a) and logarithmic (b) axes.
# Without gravity W is nominal (with the unit g). Twice Eq. 5's T_z is drawn, as in Fig. 2.
load 'style.gp'
set multiplot
set tmargin at screen 0.965
set bmargin at screen 0.135
set xlabel '{/:Italic W} = {/:Italic V}_p^2 / ({/:Italic d g}),  nominal without gravity'
set ylabel '2{/:Italic T}_z / ({/:Italic m V}_p^2),   {/:Italic T}_z by Eq. (5)' offset 0.3
set datafile missing  # a line ends at a point that is not steady
is(word, c, value) = strcol(c) eq word ? value : NaN
isnt(word, c, value) = strcol(c) ne word ? value : NaN
do for [panel = 1:2] {
  set lmargin at screen (panel == 1 ? 0.085 : 0.585)
  set rmargin at screen (panel == 1 ? 0.475 : 0.975)
  set label 1 (panel == 1 ? '(a)' : '(b)') at graph 0.04, 0.94
  if (panel == 1) {
    set xrange [0:475]
    set yrange [0:*]
    set xtics 0, 100
    set key at graph 0.97, 0.97 right top Left reverse font ',11' samplen 2
  } else {
    set logscale xy
    set xrange [0.7:600]
    set xtics (1, 10, 100)
    set yrange [*:*]
    set format y '10^{%T}'
    unset key
  }
  plot heavy using (column(heavy_W)):(is('steady', heavy_state, column(heavy_T_z_twice_scaled))):(column(heavy_T_z_twice_scaled_se)) \
         with yerrorlines pointtype 7 pointsize 0.8 linewidth 1.4 linecolor rgb blue title 'with gravity', \
       heavy using (isnt('steady', heavy_state, column(heavy_W))):(column(heavy_T_z_twice_scaled)):(column(heavy_T_z_twice_scaled_se)) \
         with yerrorbars pointtype 6 pointsize 0.9 linewidth 1.4 linecolor rgb blue, \
       weightless using (column(weightless_W_nominal)):(is('steady', weightless_state, column(weightless_T_z_twice_scaled))):(column(weightless_T_z_twice_scaled_se)) \
         with yerrorlines pointtype 5 pointsize 0.8 linewidth 1.4 linecolor rgb vermillion title 'without gravity', \
       weightless using (isnt('steady', weightless_state, column(weightless_W_nominal))):(column(weightless_T_z_twice_scaled)):(column(weightless_T_z_twice_scaled_se)) \
         with yerrorbars pointtype 4 pointsize 0.9 linewidth 1.4 linecolor rgb vermillion, \
       keyentry with points pointtype 6 pointsize 0.9 linecolor rgb grey title 'not known to be steady', \
       keyentry with yerrorbars pointtype 0 linecolor rgb grey title '± one standard error'
}
unset multiplot
