# The large grain with background damping, initial height 55 d0, at integer T. The experiment of the paper is not printed; sun2006-experiment holds a user's points.
load 'style.gp'
load 'rise.gp'
stats heights_rise using (column(heights_rise_grains)) nooutput
set label 8 sprintf('%d small grains', STATS_max) at screen 0.55, 0.975 center font ',11'
set multiplot
set lmargin at screen 0.11
set rmargin at screen 0.97
array values[3] = ['b 0.24', 'b 0.24 fine step', 'b 0']
array labels[3] = ['{/:Italic b} = 0.24, {/:Italic dt} = 2 10^{-4} ({/:Italic t}_c/25)', '{/:Italic b} = 0.24, {/:Italic dt} = {/:Italic t}_c/50', '{/:Italic b} = 0']
plot for [v = 1:3] for [r = 1:6] heights using (one_of(heights_bed, values[v], r, heights_replicate) ? column(heights_T) : NaN):(column(heights_large_height)) \
       with linespoints pointtype 7 pointsize 0.35 linewidth 1.4 linecolor rgb hues[v], \
     for [v = 1:3] keyentry with lines linewidth 2 linecolor rgb hues[v] title labels[v], \
     experiment using (column(experiment_cycle)):(column(experiment_height)) with points pointtype 4 pointsize 1 linecolor rgb 'black' title 'experiment'
unset multiplot
