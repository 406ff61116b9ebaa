# Fig. 8: 20 instants of each cycle; (a) first replica of each, (b) mu_wall = 0.5 and the base.
load 'style.gp'
load 'rise.gp'
unset offsets
set multiplot
set lmargin at screen 0.07
set rmargin at screen 0.485
set label 1 '(a)' at graph 0.93, 0.06
set yrange [*:*]
set offsets 0, 0, graph 0.15, 0
here(mu) = (strcol(heights_mu_wall) eq mu && column(heights_replicate) == 1) ? column(heights_T) : NaN
plot heights using (here('0')):(column(heights_large_height)) with lines linewidth 1 linecolor rgb orange title '{/Symbol m}_{wall} = 0', \
     heights using (here('0.5')):(column(heights_large_height)) with lines linewidth 1 linecolor rgb blue title '{/Symbol m}_{wall} = 0.5'
set lmargin at screen 0.575
set rmargin at screen 0.985
set label 1 '(b)'
set offsets 0, 0, graph 0.25, 0
set xrange [10:*<20]
set ylabel 'height  [{/:Italic d}_0]'
plot heights using (here('0.5')):(column(heights_large_height)) with lines linewidth 1.6 linecolor rgb blue title 'large grain', \
     heights using (here('0.5')):(column(heights_small_height)) with lines linewidth 1.6 linecolor rgb vermillion title 'centre of mass of small grains', \
     heights using (here('0.5')):(column(heights_base_height)) with lines linewidth 1.2 dashtype '-' linecolor rgb grey title 'base'
unset multiplot
