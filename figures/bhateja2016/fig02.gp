# Fig. 2: scaled temperature against W, with the W ranges of earlier studies above it and the onset
# of motion as an inset. The paper draws twice the T_z of its Eq. 5 (inferred), so we draw that too.
load 'style.gp'
set multiplot
set lmargin at screen 0.105
set rmargin at screen 0.98
set xrange [0:145]

# Earlier studies: solid where T was measured, dashed where dh_cm was (as in the paper); grey where
# the range is our reconstruction.
set tmargin at screen 0.985
set bmargin at screen 0.775
unset ytics
set format x ''
set yrange [-5.5:0.5]
set label 1 'solid: {/:Italic T} measured' at graph 0.985, 0.88 right font ',11'
set label 2 'dashed: Δ{/:Italic h}_{cm} measured' at graph 0.985, 0.74 right font ',11'
set label 3 'grey: range reconstructed, uncertain (×0.7 to ×1.4)' at graph 0.985, 0.12 right font ',11'
shade(n) = strcol(studies_provenance) eq 'given' ? 0x000000 : 0x888888
drawn(how) = strcol(studies_measured) eq how ? column(studies_W_from) : NaN
name(n) = strcol(studies_study) . ' (' . strcol(studies_dimension) . 'D)'
ends_high(n) = column(studies_W_to) > 70
plot studies using (drawn('T')):(-$0):(column(studies_W_to) - column(studies_W_from)):(0):(shade($0)) \
       with vectors nohead linewidth 3 linecolor rgb variable, \
     studies using (drawn('dh_cm')):(-$0):(column(studies_W_to) - column(studies_W_from)):(0):(shade($0)) \
       with vectors nohead linewidth 3 dashtype (3, 2) linecolor rgb variable, \
     studies using (ends_high($0) ? NaN : column(studies_W_to)):(-$0):(name($0)) \
       with labels left offset 0.8, 0 font ',11' noenhanced, \
     studies using (ends_high($0) ? column(studies_W_from) : NaN):(-$0):(name($0)) \
       with labels right offset -0.8, 0 font ',11' noenhanced
unset label 1; unset label 2; unset label 3

set tmargin at screen 0.765
set bmargin at screen 0.105
set format x '%g'
set ytics auto
set yrange [0:*]
set xlabel '{/:Italic W} = {/:Italic V}_p^2 / ({/:Italic d g})'
set ylabel '2{/:Italic T}_z / ({/:Italic m V}_p^2),   {/:Italic T}_z by Eq. (5)' offset 0.3
set key at graph 0.30, 0.55 left top Left reverse font ',10.5' samplen 1
plot for [s = 1:4] points using (steady(s, column(points_W))):(column(points_T_z_twice_scaled)):(column(points_T_z_twice_scaled_se)) \
       with yerrorlines pointtype filled[s] pointsize 0.7 linecolor rgb colours[s] linewidth 1.2 title systems[s], \
     for [s = 1:4] points using (marked(s, column(points_W))):(column(points_T_z_twice_scaled)):(column(points_T_z_twice_scaled_se)) \
       with yerrorbars pointtype open[s] pointsize 0.9 linecolor rgb colours[s] linewidth 1.2, \
     keyentry with points pointtype 6 pointsize 0.9 linecolor rgb grey title 'at rest or not stationary', \
     keyentry with yerrorbars pointtype 0 linecolor rgb grey title '± one standard error'

# The onset: T_z leaves zero between W = 0.89 and 1.40 at A = d.
set lmargin at screen 0.70
set rmargin at screen 0.955
set tmargin at screen 0.735
set bmargin at screen 0.55
unset xlabel
unset ylabel
unset key
set xrange [0:6]
set xtics 1 font ',11'
set ytics font ',11'
set label 4 'onset' at graph 0.06, 0.9 font ',11'
replot
unset multiplot
