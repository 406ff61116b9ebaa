# Fig. 7: the ratio of temperature and rise of the centre of mass against W, with the ranges of W of
# the studies in Table II above it (grey: reconstructed, uncertain).
load 'style.gp'
set multiplot
set lmargin at screen 0.105
set rmargin at screen 0.98
set xrange [0:145]

set tmargin at screen 0.985
set bmargin at screen 0.80
unset ytics
set format x ''
set yrange [-3.6:0.6]
shade(n) = strcol(studies_provenance) eq 'given' ? 0x000000 : 0x888888
plot studies using (column(studies_W_from)):(-$0):(column(studies_W_to) - column(studies_W_from)):(0):(shade($0)) \
       with vectors nohead linewidth 3 linecolor rgb variable, \
     studies using (column(studies_W_to)):(-$0):(strcol(studies_study) . ' (' . strcol(studies_dimension) . 'D)') \
       with labels left offset 0.8, 0 font ',11' noenhanced

set tmargin at screen 0.79
set bmargin at screen 0.12
set format x '%g'
set ytics auto
set yrange [0:*]
set xlabel '{/:Italic W} = {/:Italic V}_p^2 / ({/:Italic d g})'
set ylabel '2{/:Italic T}_z / ({/:Italic m g} Δ{/:Italic h}_{cm}),   {/:Italic T}_z by Eq. (5)' offset 0.3
set key at graph 0.985, 0.05 right bottom Left reverse samplen 1.5
y(n) = column(points_T_z_twice_over_delta_h_cm)
se(n) = column(points_T_z_twice_over_delta_h_cm_se)
# A bed that has hardly risen has a ratio of no meaning; marked points are drawn on the axis.
plot for [s = 2:4:2] points using (steady(s, column(points_W))):(y(0)):(se(0)) \
       with yerrorlines pointtype filled[s] pointsize 0.7 linecolor rgb colours[s] linewidth 1.2 title systems[s], \
     for [s = 2:4:2] points using (marked(s, column(points_W))):(0) \
       with points pointtype open[s] pointsize 0.9 linecolor rgb colours[s], \
     keyentry with points pointtype 6 pointsize 0.9 linecolor rgb grey title 'at rest or not stationary (no ratio)', \
     keyentry with yerrorbars pointtype 0 linecolor rgb grey title '± one standard error'
unset multiplot
