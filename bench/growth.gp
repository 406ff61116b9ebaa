# Cost of the event engine against the size of the bed, from bench_growth's CSV.
# gnuplot -e "data='growth.csv'; picture='growth.svg'" growth.gp
set datafile separator comma
set terminal svg size 900,400 font "sans,11"
set output picture
set multiplot layout 1,2
set logscale xy
set key bottom right
series(name) = "<grep '^".name.",' ".data
set xlabel "collisions per cycle"
set ylabel "CPU time per cycle [ms]"
plot series("wider") using 4:5 with linespoints title "wider, 4 layers", \
     series("deeper") using 4:5 with linespoints title "deeper, 5 x 5 d", \
     x*2.5e-3 with lines dashtype 2 linecolor "gray" title "linear"
set xlabel "grains"
set ylabel "CPU time per collision [us]"
unset logscale y
set yrange [0:*]
set key top left
plot series("wider") using 2:6 with linespoints title "wider, 4 layers", \
     series("deeper") using 2:6 with linespoints title "deeper, 5 x 5 d"
unset multiplot
