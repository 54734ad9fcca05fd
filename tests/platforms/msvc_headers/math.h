#pragma once
extern "C" {
double sqrt(double x);
double fma(double a, double b, double c);
float fmaf(float a, float b, float c);
}
